// SPDX-License-Identifier: MIT
#include "ros1/node.hpp"

#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <atomic>
#include <mutex>

#include "base/text.hpp"
#include "ros1/console.hpp"

namespace hallway::ros1 {
namespace {

std::atomic<bool> node_exists = false;
std::atomic<bool> node_end_asked = false;
std::string first_identity;  ///< what roscpp was initialised with; guarded by node_exists

void take_end_request(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  std::string reason;
  if (parameters.getType() == XmlRpc::XmlRpcValue::TypeArray && parameters.size() > 1 &&
      parameters[1].getType() == XmlRpc::XmlRpcValue::TypeString) {
    reason = static_cast<std::string&>(parameters[1]);
  }
  say(HW_LOG_WARNING, "this ROS node was asked to end: " + printable(reason));
  node_end_asked = true;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

/// Makes every later call of roscpp to the master fail at once: all go through one client that is used again and again, and one
/// that is in the middle of a call refuses another.
void keep_from_master() {
  ros::XMLRPCManager& manager = *ros::XMLRPCManager::instance();
  XmlRpc::XmlRpcClient* client =
      manager.getXMLRPCClient(ros::master::getHost(), static_cast<int>(ros::master::getPort()), "/");
  client->_executing = true;
  manager.releaseXMLRPCClient(client);
}

void initialise(const Settings& settings) {
  const std::string identity = settings.node + " at " + settings.master + " " + settings.address;
  if (ros::isInitialized()) {
    if (first_identity == identity) return;
    throw sdk::Failure(HW_ERROR_UNSUPPORTED,
                       "this process was another ROS node before (" +
                           (first_identity.empty() ? "of the host" : printable(first_identity)) +
                           "); roscpp can be one only");
  }
  // With a name for a log that nobody writes, roscpp makes no folder for one.
  ros::M_string remappings{{"__master", settings.master}, {"__log", "/dev/null"}};
  if (!settings.address.empty()) remappings["__hostname"] = settings.address;
  try {
    // Without rosout: what is worth reading goes to the host's log.
    ros::init(remappings, settings.node, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  } catch (const ros::Exception& failure) {
    throw sdk::Failure(HW_ERROR_ARGUMENT, "node: " + printable(failure.what(), 500));
  }
  first_identity = identity;
}

}  // namespace

Node::Node(const Settings& settings) {
  if (node_exists.exchange(true)) {
    throw sdk::Failure(HW_ERROR_STATE,
                       "another driver of this process is a ROS node, or still ends being one");
  }
  ::sigaction(SIGPIPE, nullptr, &previous_sigpipe_);
  try {
    initialise(settings);
    // roscpp writes to sockets that the other side may have closed.
    ::signal(SIGPIPE, SIG_IGN);
    node_end_asked = false;
    ros::master::setRetryTimeout(ros::WallDuration(std::chrono::duration<double>(settings.wait).count()));
    ros::start();
  } catch (...) {
    ::sigaction(SIGPIPE, &previous_sigpipe_, nullptr);
    node_exists = false;
    throw;
  }
  // roscpp would end at once; the host shall stop the robot first.
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", &take_end_request);
}

Node::~Node() {
  shut_down(true);
  ::sigaction(SIGPIPE, &previous_sigpipe_, nullptr);
  node_exists = false;
}

void Node::shut_down(bool tell_master) {
  if (ros::isStarted() && !tell_master) keep_from_master();
  ros::shutdown();
}

bool Node::end_asked() {
  return node_end_asked;
}

}  // namespace hallway::ros1
